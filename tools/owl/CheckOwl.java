// Checks one ontology with the OWL API and HermiT.
//
// Usage: CheckOwl [--reason] [--limit=SECONDS] [--map=IRI=FILE]... FILE
//
// Prints one line for each finding, fields separated by tabs:
//   missing   IRI        an import that no --map names; it is left out
//   violation TEXT       of the OWL 2 DL profile, in FILE itself; those of its imports are not reported
//   axioms    NUMBER     logical axioms in FILE
//   verdict   consistent | inconsistent | undecided

import java.io.File;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import org.semanticweb.HermiT.Configuration;
import org.semanticweb.HermiT.Reasoner;
import org.semanticweb.owlapi.apibinding.OWLManager;
import org.semanticweb.owlapi.io.FileDocumentSource;
import org.semanticweb.owlapi.model.IRI;
import org.semanticweb.owlapi.model.MissingImportHandlingStrategy;
import org.semanticweb.owlapi.model.OWLOntology;
import org.semanticweb.owlapi.model.OWLOntologyLoaderConfiguration;
import org.semanticweb.owlapi.model.OWLOntologyManager;
import org.semanticweb.owlapi.profiles.OWL2DLProfile;
import org.semanticweb.owlapi.profiles.OWLProfileViolation;
import org.semanticweb.owlapi.util.SimpleIRIMapper;

public class CheckOwl {
    private static void say(String kind, Object text) {
        System.out.println(kind + "\t" + String.valueOf(text).replaceAll("\\s+", " "));
    }

    public static void main(String[] arguments) throws Exception {
        OWLOntologyManager manager = OWLManager.createOWLOntologyManager();
        boolean reasons = false;
        long limit = 600;
        File file = null;
        for (String argument : arguments) {
            if (argument.equals("--reason")) {
                reasons = true;
            } else if (argument.startsWith("--limit=")) {
                limit = Long.parseLong(argument.substring("--limit=".length()));
            } else if (argument.startsWith("--map=")) {
                // Neither the IRIs of ontologies nor the file paths contain an equals sign.
                String[] parts = argument.split("=", 3);
                IRI document = IRI.create(new File(parts[2]));
                manager.getIRIMappers().add(new SimpleIRIMapper(IRI.create(parts[1]), document));
            } else {
                file = new File(argument);
            }
        }
        OWLOntology ontology = load(manager, file);
        for (String violation : violations(ontology)) {
            say("violation", violation);
        }
        say("axioms", ontology.getLogicalAxiomCount());
        if (reasons) {
            say("verdict", verdict(ontology, limit));
        }
        // HermiT cannot be interrupted.
        System.exit(0);
    }

    private static OWLOntology load(OWLOntologyManager manager, File file) throws Exception {
        manager.addMissingImportListener(event -> say("missing", event.getImportedOntologyURI()));
        OWLOntologyLoaderConfiguration settings = new OWLOntologyLoaderConfiguration()
            .setMissingImportHandlingStrategy(MissingImportHandlingStrategy.SILENT)
            .setFollowRedirects(false)
            .setConnectionTimeout(1);
        return manager.loadOntologyFromOntologyDocument(new FileDocumentSource(file), settings);
    }

    private static List<String> violations(OWLOntology ontology) {
        List<String> found = new ArrayList<>();
        for (OWLProfileViolation violation : new OWL2DLProfile().checkOntology(ontology).getViolations()) {
            boolean isOurs = violation.getAxiom() == null
                ? violation.getOntologyID().equals(ontology.getOntologyID())
                : ontology.containsAxiom(violation.getAxiom());
            if (isOurs) {
                found.add(violation.toString());
            }
        }
        found.sort(null);
        return found;
    }

    private static String verdict(OWLOntology ontology, long limit) throws InterruptedException, ExecutionException {
        Configuration settings = new Configuration();
        settings.ignoreUnsupportedDatatypes = true;
        ExecutorService worker = Executors.newSingleThreadExecutor();
        Callable<Boolean> question = () -> new Reasoner(settings, ontology).isConsistent();
        Future<Boolean> answer = worker.submit(question);
        try {
            return answer.get(limit, TimeUnit.SECONDS) ? "consistent" : "inconsistent";
        } catch (TimeoutException late) {
            return "undecided";
        }
    }
}
