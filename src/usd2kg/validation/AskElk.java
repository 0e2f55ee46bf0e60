// Asks ELK whether a graph is consistent with its ontology, and which individuals it is not.
//
// Usage: AskElk ONTOLOGY GRAPH        both without imports, Turtle; GRAPH holds what ONTOLOGY states, too
//
// Prints one line for each answer, fields parted by tabs:
//   beyond      NUMBER     axioms of GRAPH that are beyond OWL 2 EL, which ELK does not hear
//   axioms      NUMBER     logical axioms of GRAPH
//   impossible  CLASS      a class that can have no member, by ONTOLOGY alone
//   verdict     consistent | inconsistent
//   clash       INDIVIDUAL                    what is said of it cannot be
//   type        INDIVIDUAL  CLASS             part of why: a smallest set of what is said of it
//   relation    INDIVIDUAL  PROPERTY  OTHER   the same
//   follows     INDIVIDUAL                    cannot be, because it is related to one that cannot be

import java.io.File;
import java.util.ArrayList;
import java.util.Collections;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.semanticweb.elk.owlapi.ElkReasonerFactory;
import org.semanticweb.owlapi.apibinding.OWLManager;
import org.semanticweb.owlapi.formats.TurtleDocumentFormat;
import org.semanticweb.owlapi.io.FileDocumentSource;
import org.semanticweb.owlapi.model.AxiomType;
import org.semanticweb.owlapi.model.IRI;
import org.semanticweb.owlapi.model.OWLAxiom;
import org.semanticweb.owlapi.model.OWLClass;
import org.semanticweb.owlapi.model.OWLClassAssertionAxiom;
import org.semanticweb.owlapi.model.OWLClassExpression;
import org.semanticweb.owlapi.model.OWLDataFactory;
import org.semanticweb.owlapi.model.OWLIndividual;
import org.semanticweb.owlapi.model.OWLObjectPropertyAssertionAxiom;
import org.semanticweb.owlapi.model.OWLOntology;
import org.semanticweb.owlapi.profiles.OWL2ELProfile;
import org.semanticweb.owlapi.reasoner.OWLReasoner;

public class AskElk {
    /** What the graph says of an individual: that it is of a class, or related to another individual. */
    private record Statement(OWLIndividual subject, OWLClassExpression type, OWLObjectPropertyAssertionAxiom relation) {
        void print() {
            if (relation == null) {
                say("type", name(subject), type.isAnonymous() ? type.toString() : name(type.asOWLClass()));
            } else {
                say("relation", name(subject), relation.getProperty().getNamedProperty().getIRI(), name(relation.getObject()));
            }
        }
    }

    private static final OWLDataFactory FACTORY = OWLManager.getOWLDataFactory();

    private static void say(Object... fields) {
        Stream<String> clean = Stream.of(fields).map(field -> String.valueOf(field).replaceAll("\\s+", " "));
        System.out.println(clean.collect(Collectors.joining("\t")));
    }

    private static Object name(OWLIndividual individual) {
        return individual.isNamed() ? individual.asOWLNamedIndividual().getIRI() : individual;
    }

    private static Object name(OWLClass cls) {
        return cls.getIRI();
    }

    public static void main(String[] arguments) throws Exception {
        OWLOntology ontology = load(arguments[0]);
        OWLOntology graph = load(arguments[1]);
        say("axioms", graph.getLogicalAxiomCount());
        say("beyond", new OWL2ELProfile().checkOntology(graph).getViolations().stream()
            .map(violation -> violation.getAxiom()).filter(axiom -> axiom != null && axiom.isLogicalAxiom()).distinct().count());
        for (OWLClass cls : impossible(ontology)) {
            say("impossible", cls.getIRI());
        }
        OWLReasoner reasoner = new ElkReasonerFactory().createReasoner(graph);
        boolean isConsistent = reasoner.isConsistent();
        reasoner.dispose();
        say("verdict", isConsistent ? "consistent" : "inconsistent");
        if (!isConsistent) {
            explain(graph);
        }
        System.exit(0);
    }

    private static OWLOntology load(String path) throws Exception {
        FileDocumentSource source = new FileDocumentSource(new File(path), new TurtleDocumentFormat());
        return OWLManager.createOWLOntologyManager().loadOntologyFromOntologyDocument(source);
    }

    private static List<OWLClass> impossible(OWLOntology ontology) {
        OWLReasoner reasoner = new ElkReasonerFactory().createReasoner(ontology);
        List<OWLClass> found = new ArrayList<>();
        if (reasoner.isConsistent()) {
            reasoner.getUnsatisfiableClasses().getEntitiesMinusBottom().stream().sorted().forEach(found::add);
        }
        reasoner.dispose();
        return found;
    }

    // From an inconsistent graph all follows. So each individual is made a class of its own, below what is said of it;
    // those that can have no member are the individuals that cannot be, and the others remain as they are.
    private static void explain(OWLOntology graph) throws Exception {
        Map<OWLIndividual, List<Statement>> said = statements(graph);
        Map<OWLIndividual, OWLClass> classes = new LinkedHashMap<>();
        for (OWLIndividual individual : said.keySet()) {
            classes.put(individual, FACTORY.getOWLClass(IRI.create("urn:usd2kg:individual:" + classes.size())));
        }
        Set<OWLAxiom> axioms = graph.logicalAxioms().filter(axiom -> !isAssertion(axiom)).collect(Collectors.toSet());
        said.forEach((individual, statements) -> statements.forEach(statement -> axioms.add(
            FACTORY.getOWLSubClassOfAxiom(classes.get(individual), expression(statement, classes, Set.of())))));
        OWLReasoner reasoner = new ElkReasonerFactory().createReasoner(OWLManager.createOWLOntologyManager().createOntology(axioms));
        Set<OWLClass> bottom = reasoner.getUnsatisfiableClasses().entities().collect(Collectors.toSet());
        Set<OWLIndividual> lost = new HashSet<>();
        classes.forEach((individual, cls) -> {
            if (bottom.contains(cls)) {
                lost.add(individual);
            }
        });
        lost.stream().sorted().forEach(individual -> explain(individual, said.get(individual), classes, lost, reasoner));
    }

    private static void explain(OWLIndividual individual, List<Statement> said, Map<OWLIndividual, OWLClass> classes,
            Set<OWLIndividual> lost, OWLReasoner reasoner) {
        if (reasoner.isSatisfiable(together(said, classes, lost))) {
            say("follows", name(individual));
            return;
        }
        List<Statement> needed = new ArrayList<>(said);
        List<Statement> relationsFirst = new ArrayList<>(said);
        Collections.reverse(relationsFirst);
        // Two classes that exclude each other tell more than a class and one of the many relations that imply the other.
        for (Statement statement : relationsFirst) {
            List<Statement> fewer = new ArrayList<>(needed);
            fewer.remove(statement);
            if (!fewer.isEmpty() && !reasoner.isSatisfiable(together(fewer, classes, lost))) {
                needed = fewer;
            }
        }
        say("clash", name(individual));
        needed.forEach(Statement::print);
    }

    private static OWLClassExpression together(List<Statement> said, Map<OWLIndividual, OWLClass> classes, Set<OWLIndividual> lost) {
        return FACTORY.getOWLObjectIntersectionOf(said.stream().map(statement -> expression(statement, classes, lost)));
    }

    /** As a class; what is said of the individuals `unheard` is left out of it. */
    private static OWLClassExpression expression(Statement statement, Map<OWLIndividual, OWLClass> classes, Set<OWLIndividual> unheard) {
        if (statement.relation() == null) {
            return statement.type();
        }
        OWLIndividual other = statement.relation().getObject();
        OWLClassExpression filler = unheard.contains(other) || !classes.containsKey(other) ? FACTORY.getOWLThing() : classes.get(other);
        return FACTORY.getOWLObjectSomeValuesFrom(statement.relation().getProperty(), filler);
    }

    private static Map<OWLIndividual, List<Statement>> statements(OWLOntology graph) {
        Map<OWLIndividual, List<Statement>> found = new LinkedHashMap<>();
        graph.axioms(AxiomType.CLASS_ASSERTION).sorted().forEach((OWLClassAssertionAxiom axiom) -> found
            .computeIfAbsent(axiom.getIndividual(), key -> new ArrayList<>())
            .add(new Statement(axiom.getIndividual(), axiom.getClassExpression(), null)));
        graph.axioms(AxiomType.OBJECT_PROPERTY_ASSERTION).sorted().forEach((OWLObjectPropertyAssertionAxiom axiom) -> found
            .computeIfAbsent(axiom.getSubject(), key -> new ArrayList<>())
            .add(new Statement(axiom.getSubject(), null, axiom)));
        return found;
    }

    private static boolean isAssertion(OWLAxiom axiom) {
        return AxiomType.ABoxAxiomTypes.contains(axiom.getAxiomType());
    }
}
